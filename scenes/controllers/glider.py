# A glider with an upward force of its own, as a helicopter has. Level it hovers. Its pilot steers it by standing on it: the foot that is
# lifted off the deck pitches it, the way the chest faces turns it.
PILOT = "pilot"


class Glider:
    mass = 60 + 80          # its own and the pilot's, who stands on it
    height = 1.6

    def start(self):
        self.pitch = 0.0
        self.turn = 0.0

    def step(self):
        up, ahead, left = toWorld(me, (0, 1, 0)), toWorld(me, (0, 0, 1)), toWorld(me, (1, 0, 0))
        # Above 0 when the foot behind is the higher one: nose down, ahead.
        levels = (getPosition(PILOT + ".rightFoot") - getPosition(PILOT + ".leftFoot")).dot(up)
        # Both on the deck are never level to the millimetre.
        levels -= max(-0.01, min(0.01, levels))
        facing = toWorld(PILOT + ".chest", (0, 0, 1))
        # What the pilot does reaches the rudders in a quarter of a second.
        share = min(1.0, getTimeStep() / 0.25)
        self.pitch += share * (max(-0.12, min(0.12, 2.2 * levels)) - self.pitch)
        self.turn += share * (max(-0.9, min(0.9, 1.6 * facing.dot(left))) - self.turn)

        # Upward along its own axis, with a little help to keep its height.
        fall = self.height - getPosition(me).y - 0.9 * getVelocity(me).y
        push(me, self.mass * (9.81 + 6.7 * fall) * up)
        # Couples at nose and wing tips turn it: to the wanted pitch, level across, at the wanted rate about its own axis.
        spin = getSpin(me)
        nose = 6000 * (self.pitch + ahead.y) - 1300 * spin.dot(left)
        roll = -6000 * left.y - 1300 * spin.dot(ahead)
        yaw = 500 * (self.turn - spin.dot(up))
        push(me, (0 - nose) * up, at=(0, 0, 0.5))
        push(me, nose * up, at=(0, 0, -0.5))
        push(me, roll * up, at=(0.5, 0, 0))
        push(me, (0 - roll) * up, at=(-0.5, 0, 0))
        push(me, yaw * left, at=(0, 0, 0.5))
        push(me, (0 - yaw) * left, at=(0, 0, -0.5))
        # A keel: it goes where it faces.
        push(me, -5 * self.mass * getVelocity(me).dot(left) * left)
