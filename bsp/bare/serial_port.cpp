#include "bsp/bare/serial_port.hpp"

namespace lasso::bare {

bool SerialPort::all_sent() const { return !sending_ && out_.room() == lcs::kLineBytes; }

}  // namespace lasso::bare
