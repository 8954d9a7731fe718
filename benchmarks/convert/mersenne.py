"""The random numbers of the project's programs: the 64-bit Mersenne Twister (Matsumoto and Nishimura), which neither
the standard library nor NumPy provides."""

SIZE, MIDDLE = 312, 156
MASK = (1 << 64) - 1
UPPER, LOWER = MASK ^ 0x7FFFFFFF, 0x7FFFFFFF
TWIST = 0xB5026F5AA96619E9


class Random:
    """A generator; the same seed gives the same numbers."""

    def __init__(self, seed):
        state = [seed & MASK]
        for k in range(1, SIZE):
            state.append((6364136223846793005 * (state[-1] ^ (state[-1] >> 62)) + k) & MASK)
        self.state, self.place = state, SIZE

    def bits(self):
        """64 random bits."""
        if self.place == SIZE:
            self.twist()
        value = self.state[self.place]
        self.place += 1
        value ^= (value >> 29) & 0x5555555555555555
        value ^= (value << 17) & 0x71D67FFFEDA60000
        value ^= (value << 37) & 0xFFF7EEE000000000
        return value ^ (value >> 43)

    def twist(self):
        state = self.state
        for k in range(SIZE):
            value = (state[k] & UPPER) | (state[(k + 1) % SIZE] & LOWER)
            state[k] = state[(k + MIDDLE) % SIZE] ^ (value >> 1) ^ (TWIST if value & 1 else 0)
        self.place = 0

    def between(self, low, high):
        """A number evenly distributed from low (included) to high (excluded)."""
        return low + (high - low) * ((self.bits() >> 11) * 2.0 ** -53)

    def below(self, count):
        """An index from 0 to count - 1."""
        return self.bits() % count

    def chance(self, probability):
        """True with this probability."""
        return self.between(0.0, 1.0) < probability

    def normal(self, mean, deviation, low, high):
        """A normally distributed number (the sum of twelve even ones), cut off."""
        sum_of_even = sum((self.between(0.0, 1.0) for _ in range(12)), -6.0)
        return min(max(mean + deviation * sum_of_even, low), high)
