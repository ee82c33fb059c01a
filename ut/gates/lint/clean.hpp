#pragma once

namespace lasso {

int absolute(int value);

}  // namespace lasso
