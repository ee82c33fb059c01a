// What the other end makes of a frame's bytes.
#pragma once

#include <gtest/gtest.h>

#include "hal_lcs/frame.hpp"

namespace lasso::lcs {

inline Frame received(const FrameBytes& bytes) {
  FrameDecoder decoder;
  Frame frame;
  EXPECT_TRUE(decoder.step(bytes.span(), frame).found);
  return frame;
}

}  // namespace lasso::lcs
