"""Instructions of the PowerPC, as objdump writes them."""
import re

# Loads, stores and arithmetic of the floating-point unit, and what moves its state.
FLOATING = re.compile(r'\t(f[a-z]+|lf[sd]u?x?|stf[sd]u?x?|stfiwx|mffs|mtfsf|mtfsfi|mtfsb[01]|mcrfs)\.?(?:\s|$)')
