from math import sqrt

MODULES = ("math", "random", "itertools")


class Future:
    """`from __future__ import ...` is for the compiler; these are the names that it asks for."""

    annotations = division = generators = nested_scopes = print_function = unicode_literals = with_statement = True
    absolute_import = generator_stop = True


def gate(real):
    def __import__(name, globals=None, locals=None, fromlist=(), level=0):
        if name == "__future__" and level == 0:
            return Future
        if level != 0:
            raise ImportError("a controller is one file: there is nothing beside it to import")
        if name not in MODULES:
            problem = f"no module '{name}' in a controller; there are: {', '.join(MODULES)}"
            raise ModuleNotFoundError(problem, name=name)
        return real(name, globals, locals, fromlist, level)

    return __import__


class Vector(tuple):
    """Three numbers that can be added and scaled."""

    __slots__ = ()

    def __new__(cls, x=0.0, y=0.0, z=0.0):
        return tuple.__new__(cls, (float(x), float(y), float(z)))

    x = property(lambda self: self[0])
    y = property(lambda self: self[1])
    z = property(lambda self: self[2])

    def __add__(self, other):
        x, y, z = other
        return Vector(self[0] + x, self[1] + y, self[2] + z)

    def __radd__(self, other):
        return self + other

    def __sub__(self, other):
        x, y, z = other
        return Vector(self[0] - x, self[1] - y, self[2] - z)

    def __rsub__(self, other):
        return -self + other

    def __mul__(self, factor):
        return Vector(self[0] * factor, self[1] * factor, self[2] * factor)

    def __rmul__(self, factor):
        return self * factor

    def __truediv__(self, divisor):
        return Vector(self[0] / divisor, self[1] / divisor, self[2] / divisor)

    def __neg__(self):
        return Vector(-self[0], -self[1], -self[2])

    def __repr__(self):
        return f"({self[0]}, {self[1]}, {self[2]})"

    def dot(self, other):
        x, y, z = other
        return self[0] * x + self[1] * y + self[2] * z

    def cross(self, other):
        x, y, z = other
        return Vector(self[1] * z - self[2] * y, self[2] * x - self[0] * z, self[0] * y - self[1] * x)

    def length(self):
        return sqrt(self.dot(self))

    def normalized(self):
        length = self.length()
        return self / length if length > 0.0 else self
