# What RustPython's built-in functions and our native `math` lack of Python's own: integers, exact sums, rounding.
import math


def _rounded(real):
    def round(number, ndigits=None):
        if ndigits is None or not isinstance(number, float) or number - number != 0.0:
            return real(number) if ndigits is None else real(number, ndigits)
        if ndigits >= 0:
            # No double has more decimals. Printing rounds once, from the exact number.
            return number if ndigits > 1074 else float(f"{number:.{ndigits}f}")
        # A double is below ten to the 309.
        scale = 10 ** min(-ndigits, 400)
        above, below = number.as_integer_ratio()
        whole, rest = divmod(abs(above), below * scale)
        twice = 2 * rest - below * scale
        whole += twice > 0 or (twice == 0 and whole % 2 == 1)
        return math.copysign(float(whole * scale), number)

    return round


def _whole(number):
    if not isinstance(number, int):
        raise TypeError(f"'{type(number).__name__}' object cannot be interpreted as an integer")
    return int(number)


def _count(number, name):
    number = _whole(number)
    if number < 0:
        raise ValueError(f"{name} must be a non-negative integer")
    return number


def gcd(*integers):
    result = 0
    for other in integers:
        other = abs(_whole(other))
        while other:
            result, other = other, result % other
    return result


def lcm(*integers):
    result = 1
    for other in integers:
        other = abs(_whole(other))
        result = result // gcd(result, other) * other if other else 0
    return result


def factorial(n):
    return prod(range(2, _count(n, "n") + 1))


def perm(n, k=None):
    n = _count(n, "n")
    k = n if k is None else _count(k, "k")
    return prod(range(n - k + 1, n + 1)) if k <= n else 0


def comb(n, k):
    n, k = _count(n, "n"), _count(k, "k")
    k = min(k, n - k)
    return perm(n, k) // factorial(k) if k >= 0 else 0


def isqrt(n):
    n = _count(n, "n")
    root = 1 << (n.bit_length() + 1) // 2
    while n:
        lower = (root + n // root) // 2
        if lower >= root:
            return root
        root = lower
    return 0


def prod(iterable, *, start=1):
    for factor in iterable:
        start = start * factor
    return start


def dist(p, q):
    p, q = tuple(p), tuple(q)
    if len(p) != len(q):
        raise ValueError("both points must have the same number of dimensions")
    return math.hypot(*(a - b for a, b in zip(p, q)))


def fsum(seq):
    # Partial sums that do not overlap (Shewchuk 1997), and their sum rounded once.
    partials = []
    for x in seq:
        x = float(x)
        kept = 0
        for y in partials:
            if abs(x) < abs(y):
                x, y = y, x
            high = x + y
            low = y - (high - x)
            if low:
                partials[kept] = low
                kept += 1
            x = high
        if x - x != 0.0:
            raise OverflowError("an infinite sum")
        partials[kept:] = [x]
    total, low = 0.0, 0.0
    while partials:
        x, y = total, partials.pop()
        total = x + y
        low = y - (total - x)
        if low:
            break
    # Half-way cases go the way of what lies below.
    if partials and (low < 0.0) == (partials[-1] < 0.0) and low:
        twice = 2.0 * low
        if twice == (total + twice) - total:
            total += twice
    return total


for _function in (gcd, lcm, factorial, perm, comb, isqrt, prod, dist, fsum):
    setattr(math, _function.__name__, _function)
