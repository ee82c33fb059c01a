void planted(int value) {
  if (value < 0) throw value;
}
