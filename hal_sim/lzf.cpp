#include "hal_sim/lzf.hpp"

namespace lasso::sim {
namespace {

constexpr unsigned kLongestLiteral = 32;
constexpr unsigned kLongLength = 7;  // in the control byte: another byte adds to it

class Input {
 public:
  explicit Input(std::string_view packed) : packed_(packed) {}
  bool empty() const { return at_ == packed_.size(); }
  bool byte(unsigned& value) {
    if (empty()) return false;
    value = static_cast<unsigned char>(packed_[at_++]);
    return true;
  }
  bool literal(std::size_t length, std::string& bytes) {
    if (length > packed_.size() - at_) return false;
    bytes.append(packed_.substr(at_, length));
    at_ += length;
    return true;
  }

 private:
  std::string_view packed_;
  std::size_t at_ = 0;
};

// A copy may reach into what it writes itself.
bool copy(Input& input, unsigned control, std::string& bytes) {
  unsigned length = control >> 5, more = 0, low = 0;
  if (length == kLongLength && !input.byte(more)) return false;
  if (!input.byte(low)) return false;
  length += more + 2;
  const std::size_t back = ((control & 0x1FU) << 8 | low) + 1;
  if (back > bytes.size()) return false;
  for (unsigned i = 0; i < length; ++i) bytes.push_back(bytes[bytes.size() - back]);
  return true;
}

}  // namespace

bool unpack_lzf(std::string_view packed, std::size_t size, std::string& bytes) {
  Input input(packed);
  bytes.clear();
  while (!input.empty() && bytes.size() <= size) {
    unsigned control = 0;
    static_cast<void>(input.byte(control));
    const bool whole = control < kLongestLiteral ? input.literal(control + 1, bytes) : copy(input, control, bytes);
    if (!whole) return false;
  }
  return bytes.size() == size;
}

}  // namespace lasso::sim
