// Recursion, silenced with all around it.
namespace lasso {

// NOLINTBEGIN(misc-no-recursion,misc-use-internal-linkage): there is a reason
int planted(int value) { return value == 0 ? 0 : planted(value - 1); }
// NOLINTEND(misc-no-recursion,misc-use-internal-linkage)

}  // namespace lasso
