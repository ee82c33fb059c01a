"""What is said of bad input."""


class LassoError(ValueError):
    """One line: the file, the place in it, what is wrong there, and the remedy."""
