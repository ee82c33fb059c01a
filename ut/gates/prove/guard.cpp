int first();
int first() { return 7; }
struct State {
  State() : value(first()) {}
  ~State() { value = 0; }
  volatile int value;
};
int planted() {
  static State state;
  return state.value;
}
