// Everything that is allowed: a call, a bounded loop, a pointer that the table resolves, memory that is cleared, a table of constants.
struct Sensor {
  virtual float read() = 0;
};
struct Scan {
  float range[64];
};

extern const int kTable[4] = {1, 2, 3, 5};

[[gnu::noinline]] float read_sensor(Sensor& sensor) { return sensor.read() + 1; }

float task(Sensor& sensor, Scan& scan, float gain, float offset) {
  scan = Scan{};
  for (float& range : scan.range) range = gain * read_sensor(sensor) + offset;
  return scan.range[0];
}
