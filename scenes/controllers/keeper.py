# Takes the box, lifts it, puts it on the shelf, stands up again.
class Keeper:
    def start(self):
        skeleton.reach("box", hand="right", grasp=True, avoid=("table",))
        self.stage = "take"
        self.since = 0.0

    def step(self):
        waited = getTime() - self.since
        if self.stage == "take" and skeleton.isLinkAttached("rightHand", "box"):
            self.carry(getPosition("box") + (-0.1, 0.4, -0.1), "lift")
        elif self.stage == "lift" and waited > 1.3:
            # What the hand holds is what arrives: half a box above the shelf, and what the load lets the arm sag.
            self.carry(getPosition("shelf") + (0, 0.015 + 0.12 + 0.04, 0), "put")
        elif self.stage == "put" and waited > 1.8:
            skeleton.detachLink("rightHand", "box")
            skeleton.endReach()
            self.stage = "done"

    def carry(self, to, stage):
        skeleton.reach(to, hand="right")
        self.stage = stage
        self.since = getTime()
