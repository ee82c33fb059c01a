#include "fsw/pose/registration/minima.hpp"

#include "fsw/core/fixed_vector.hpp"
#include "fsw/pose/registration/observability.hpp"
#include "fsw/pose/scan/path_pose.hpp"

namespace lasso {
namespace {

constexpr int kReach = 6;              // places, each way
constexpr double kSpacing = 1.0 / 30;  // of the radius: less than half of what 96 flat sides are apart
constexpr double kFine = 1.0 / 16;     // of the spacing: half of what a descent from a place ends with
constexpr double kNone = 1e300;        // a cost
constexpr double kSigmas = 5;          // nearer ones are within what the pose says of itself

// What a look at one side finds.
struct Side {
  CostedPose low;  // the lowest place that lies lower than both neighbours; kNone where there is none
  CostedPose last;
  double beside = kNone;  // the cost of the first place
  double fall = 0;        // by what the last place costs less than the one before it
};

void keep_lower(const CostedPose& place, Side& side) {
  if (place.cost < side.low.cost) side.low = place;
}

Side look(const CostedPose& from, double spacing_m, Profile& profile) {
  Side side;
  side.low.cost = kNone;
  side.last = from;
  bool falls = false;
  for (int i = 1; i <= kReach; ++i) {
    const CostedPose next = profile.draw_at(from.T_target_sensor, i * spacing_m, 1);
    if (falls && !(next.cost < side.last.cost)) keep_lower(side.last, side);
    side.fall = side.last.cost - next.cost;
    falls = side.fall > 0;
    side.last = next;
    if (i == 1) side.beside = next.cost;
  }
  return side;
}

// Minima first, that of the beginning before the others; then the last places of both sides.
struct Places {
  FixedVector<CostedPose, 5> all;
  std::size_t minima = 0;
  double limit = 0;  // what costs less explains the scan about as well as the lowest of the minima
};

// What a place costs at most that is the nearest to a minimum which explains the scan, if that is as sharp as the beginning: the first
// places are twice as far from the beginning.
double most_beside(const Side (&sides)[2]) { return (sides[0].beside > sides[1].beside ? sides[0].beside : sides[1].beside) + kRise; }

// The lowest place of a side that may lie beside such a minimum, or beyond which there may be one: the last place, if it costs less than
// the one before it by more than one return may cost. Its cost is kNone where there is none.
CostedPose start_of_descent(const Side& side, double most) {
  CostedPose start = side.low;
  if (!(start.cost < most)) start.cost = kNone;
  if (side.fall > kMostOfAReturn && side.last.cost < start.cost) start = side.last;
  return start;
}

// Where the descent ends less than half of a place from the beginning, both are in the same minimum.
void add_minimum(const Side& side, double most, double spacing_m, Profile& profile, Places& places) {
  const CostedPose start = start_of_descent(side, most);
  if (!(start.cost < kNone)) return;
  const CostedPose found = profile.descend(start, 0.5 * spacing_m);
  const double way_m = profile.along_m(way_between(places.all[0].T_target_sensor, found.T_target_sensor));
  if (way_m * way_m > 0.25 * spacing_m * spacing_m) (void)places.all.push_back(found);
}

[[gnu::noinline]] void find_places(const CostedPose& from, double spacing_m, Profile& profile, Places& places) {
  const Side sides[2] = {look(from, spacing_m, profile), look(from, -spacing_m, profile)};
  (void)places.all.push_back(from);
  for (const Side& side : sides) add_minimum(side, most_beside(sides), spacing_m, profile, places);
  places.minima = places.all.size();
  double lowest = from.cost;
  for (const CostedPose& place : places.all) lowest = place.cost < lowest ? place.cost : lowest;
  places.limit = lowest + kRise;
  for (const Side& side : sides) (void)places.all.push_back(side.last);
}

// Of the minima that explain the scan, the nearest to the prediction along the axis.
std::size_t nearest(const Places& places, const Pose& predicted, const Profile& profile) {
  std::size_t best = 0;
  double least_m2 = 0;
  for (std::size_t i = 0, found = 0; i < places.minima; ++i) {
    if (!(places.all[i].cost < places.limit)) continue;
    const double way_m = profile.along_m(way_between(predicted, places.all[i].T_target_sensor));
    if (found++ > 0 && !(way_m * way_m < least_m2)) continue;
    best = i;
    least_m2 = way_m * way_m;
  }
  return best;
}

// Squared ways from a pose to what explains the scan about as well.
class Spread {
 public:
  Spread(const Pose& from, double apart_m, double anywhere_m, const Profile& profile)
      : from_(from), apart_m_(apart_m), anywhere_m_(anywhere_m), profile_(profile) {}

  void add(const Pose& other, bool is_minimum) {
    const Vec6 way = way_between(from_, other);
    const double way_m = profile_.along_m(way);
    if (way_m * way_m > apart_m_ * apart_m_) {
      apart_ += anywhere_m_ * anywhere_m_ / (way_m * way_m) * way * way.transpose();
      ++count_;
    } else if (is_minimum) {
      near_ += way * way.transpose();
    }
  }

  void describe(Minima& minima) const {
    minima.are_apart = count_ > 0;
    minima.spread = near_;
    if (count_ > 0) minima.spread += apart_ / count_;
  }

 private:
  const Pose& from_;
  double apart_m_, anywhere_m_;
  const Profile& profile_;
  Mat6 near_ = Mat6::Zero(), apart_ = Mat6::Zero();
  int count_ = 0;
};

}  // namespace

Minima find_minima(const Mission& mission, const CostedPose& from, double sigma_m, const Pose& predicted, Profile& profile) {
  const double spacing_m = kSpacing * mission.radius_m;
  Places places;
  find_places(from, spacing_m, profile, places);
  const std::size_t chosen = nearest(places, predicted, profile);
  Minima minima;
  minima.is_elsewhere = chosen != 0;
  if (minima.is_elsewhere) places.all[chosen] = profile.descend(places.all[chosen], kFine * spacing_m);
  minima.T_target_sensor = places.all[chosen].T_target_sensor;
  const double apart_m = kSigmas * sigma_m > 0.5 * spacing_m ? kSigmas * sigma_m : 0.5 * spacing_m;
  Spread spread(minima.T_target_sensor, apart_m, kUnobservableSigma * mission.radius_m, profile);
  for (std::size_t i = 0; i < places.all.size(); ++i) {
    if (places.all[i].cost < places.limit) spread.add(places.all[i].T_target_sensor, i < places.minima);
  }
  spread.describe(minima);
  return minima;
}

}  // namespace lasso
