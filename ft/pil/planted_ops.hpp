// What the planted faults do by instructions of the board's processor: a compiler may leave out what cannot be right.
#pragma once

#include <cstdint>

namespace lasso::planted {

std::uint32_t read_at(std::uint32_t address);  // a word
void write_at(std::uint32_t address);
void jump_to(std::uint32_t address);
void no_instruction();  // does what the processor has no instruction for
void call_system();     // an exception that nobody awaits
// From a slot: the background goes on there, on its own stack, when the slot is done.
void lead_background_to(void (*there)());

// Those of this processor alone, counted from 0.
std::uint32_t own_faults();
void own_fault(std::uint32_t number);

}  // namespace lasso::planted
