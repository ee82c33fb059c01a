// Seen by clang++ alone.
class Planted {
 public:
  explicit Planted(int value) : value_(value) {}

 private:
  int value_;
};
int main() {
  const Planted planted(1);
  static_cast<void>(planted);
  return 0;
}
