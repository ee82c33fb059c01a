// What both apps need of cFS: its headers as C, time, and messages sent.
#pragma once

extern "C" {
#include "cfs/message.h"
}

#include "fsw/core/time.hpp"

namespace lasso::cfs {

// Microseconds of the platform's clock, which never goes back.
inline TimeUs now_us() {
  OS_time_t now;
  CFE_PSP_GetTime(&now);
  return OS_TimeGetTotalMicroseconds(now);
}

// A message with the header of cFE, and its room on the bus.
template <class Message>
void prepare(Message& message, CFE_SB_MsgId_Atom_t id) {
  static_cast<void>(CFE_MSG_Init(CFE_MSG_PTR(message.header), CFE_SB_ValueToMsgId(id), sizeof message));
}

// Sends it with the spacecraft's time and the next sequence count. The bus counts what does not reach a pipe, and says so by an event.
template <class Message>
void send(Message& message) {
  CFE_SB_TimeStampMsg(CFE_MSG_PTR(message.header));
  static_cast<void>(CFE_SB_TransmitMsg(CFE_MSG_PTR(message.header), true));
}

// A received message as what its identifier says it is; null where its size is another one.
template <class Message>
const Message* as(const CFE_SB_Buffer_t& buffer) {
  CFE_MSG_Size_t size = 0;
  static_cast<void>(CFE_MSG_GetSize(&buffer.Msg, &size));
  return size == sizeof(Message) ? reinterpret_cast<const Message*>(&buffer) : nullptr;
}

}  // namespace lasso::cfs
