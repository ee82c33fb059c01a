// Recursion, silenced for a reason.
namespace lasso {

int planted(int value) { return value == 0 ? 0 : planted(value - 1); }  // NOLINT(misc-no-recursion,misc-use-internal-linkage): fixture

}  // namespace lasso
