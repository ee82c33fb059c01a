// What survives a restart: why the board starts, and what it last failed of. The record lies in memory that start-up leaves alone.
#pragma once

#include <cstdint>

#include "fsw/exec/watchdog.hpp"

namespace lasso::bare {

// As the vectors of a board write it (board_fault_registers), in this order; which registers these are its page says (docs/boards).
struct FaultRegisters {
  std::uint32_t vector = 0;        // the exception, by its offset in the processor's table
  std::uint32_t instruction = 0;   // that was not done
  std::uint32_t state = 0;         // of the processor, before
  std::uint32_t data_address = 0;  // of an access to data
  std::uint32_t data_status = 0;   // what was wrong with it
  std::uint32_t link = 0;          // where its function returns to
  std::uint32_t more[2] = {};      // what else the processor says
  std::uint32_t stack = 0;
};

constexpr std::uint32_t kMaxRestarts = 8;  // in a row; the next fault is the last
constexpr std::uint32_t kTextBytes = 48;

struct FaultRecord {
  std::uint32_t magic = 0;
  std::uint32_t restarts = 0;  // since power-on
  std::uint32_t in_a_row = 0;  // of them, since the last end_row_of_restarts()
  std::uint32_t cause = 0;     // ResetCause of the present start
  FaultRegisters registers;    // of the last exception
  char text[kTextBytes] = {};  // of the last failed invariant
  std::uint32_t sum = 0;       // of all words before; what memory held at power-on has another
};

// Before anything else: the record of the last life, or a new one after power-on.
const FaultRecord& open_record();
const FaultRecord& fault_record();
// The board's: the address that an exception is about, of the instruction, or of the data that it could not reach.
std::uint32_t fault_address(const FaultRegisters& registers);

// The board has done well for a while: restarts count from 0 again.
void end_row_of_restarts();

// Records, says it on the console, and starts the board anew; after kMaxRestarts in a row it stays down.
[[noreturn]] void restart(ResetCause cause, const char* text);

}  // namespace lasso::bare
