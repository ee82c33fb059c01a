char planted[65536];
