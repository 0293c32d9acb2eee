# A wind-up toy's control: the same cycle for ever, whatever happens to the toy.
class WindUp:
    wind_secs = 0.9     # closing slowly
    jump_secs = 0.14    # opening with a jerk
    open_secs = 0.14    # held open in the air

    def start(self):
        self.begun = getTime()

    def step(self):
        phase = (getTime() - self.begun) % (self.wind_secs + self.jump_secs + self.open_secs)
        if phase < self.wind_secs:
            setMotor("spring", place=-12)
        elif phase < self.wind_secs + self.jump_secs:
            setMotor("spring", speed=5)
        else:
            setMotor("spring", place=26)
