// The answers about one recording (docs/serve.md), each from the recording and what was asked. Those that cannot be given throw Refusal.
#pragma once

#include <memory>
#include <string>

#include "mdat/serve/flown_image.hpp"
#include "mdat/serve/http.hpp"
#include "mdat/serve/messages.hpp"
#include "mdat/serve/recording.hpp"
#include "mdat/serve/target.hpp"

namespace lasso::mdat::serve {

// A recording with what its answers need besides.
struct Shown {
  std::string id, name;  // the name as a user knows it
  std::shared_ptr<const Recording> recording;
};

constexpr std::size_t kMostPoints = 20000;  // of a series
constexpr std::size_t kMostEvents = 10000;  // at a time
constexpr std::size_t kMostColumns = 40;    // of a table

Response summary_answer(const Shown& shown);
Response frames_answer(const Shown& shown, const Target& target);
Response frame_answer(const Shown& shown, std::size_t n);
Response scan_answer(const Shown& shown, std::size_t n, const Target& target);
Response series_answer(const Shown& shown, const Target& target);
Response statistics_answer(const Shown& shown, const Target& target);
Response events_answer(const Shown& shown, const Target& target);
Response model_answer(const Shown& shown);
// A surface with triangles, as binary glTF in its own frame.
Response surface_answer(const SurfaceTriangles& surface);
Response csv_answer(const Shown& shown, const Target& target);

// The value that the address names. Throws Refusal: 400 none is named, 404 there is no such.
const Value& value_in(const Shown& shown, const std::string& id);

// Rows of a time line from from_s to to_s of the address.
struct RowSpan {
  std::size_t begin = 0, end = 0;
};
RowSpan rows_in(const std::vector<double>& time_s, const Target& target);

}  // namespace lasso::mdat::serve
