// Recursion, silenced without a word.
namespace lasso {

int planted(int value) { return value == 0 ? 0 : planted(value - 1); }  // NOLINT

}  // namespace lasso
