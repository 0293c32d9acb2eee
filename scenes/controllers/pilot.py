# The performer of the glider's scene, for when no live one is there: leans ahead, and faces the next gate.
GATES = ["gate_1", "gate_2", "gate_3", "gate_4"]


class Pilot:
    def start(self):
        self.next = 0
        skeleton.setTargetPose("fly")

    def step(self):
        if self.next < len(GATES) and getPosition(GATES[self.next]).z < getPosition("glider").z + 0.6:
            self.next += 1
        if self.next == len(GATES):
            skeleton.setTargetPose("fly_brake")
            return
        to = getPosition(GATES[self.next]) - getPosition("glider")
        # Where the gate will be when the glider has ended the turn that it is in.
        aside = to.dot(toWorld("glider", (1, 0, 0))) / to.length() - 0.45 * getSpin("glider").y
        if abs(aside) < 0.05:
            skeleton.setTargetPose("fly_ahead")
        elif abs(aside) < 0.15:
            skeleton.setTargetPose("fly_left_a_little" if aside > 0 else "fly_right_a_little")
        else:
            skeleton.setTargetPose("fly_left" if aside > 0 else "fly_right")
