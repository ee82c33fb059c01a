[[gnu::section(".frames")]] char planted[65536] = {1};
