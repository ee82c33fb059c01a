// What port_check needs of a board: its clock, and a task that wakes up at a time. posix.cpp has them of C++; write a file like it for
// yours.
#pragma once

#include "fsw/core/time.hpp"

namespace lasso::port {

TimeUs now_us();                // the clock that run_slot() will be called by
void sleep_until(TimeUs t_us);  // as the task of the slots waits for the next one
const char* name();             // of the board, for the report

}  // namespace lasso::port
