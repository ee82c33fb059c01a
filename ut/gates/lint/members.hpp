// A class with more members than a reader can hold, beside a record with as many.
#pragma once

namespace lasso {

struct Record {
  int a = 0, b = 0, c = 0, d = 0, e = 0, f = 0, g = 0, h = 0, i = 0, j = 0, k = 0, l = 0, m = 0, n = 0, o = 0, p = 0, q = 0, r = 0, s = 0,
      t = 0, u = 0;
};

class Crowded {
 public:
  int sum() const { return a_ + b_ + c_; }

 private:
  int a_ = 0, b_ = 0, c_{}, d_[2] = {}, e_ = 0, f_ = 0, g_ = 0, h_ = 0, i_ = 0, j_ = 0, k_ = 0, l_ = 0, m_ = 0, n_ = 0, o_ = 0, p_ = 0,
      q_ = 0, r_ = 0, s_ = 0, t_ = 0;
  Record u_;
};

}  // namespace lasso
