// Whole bodies of each kind. Inside of bodies.
#pragma once

#include "mdat/bodies/fittings.hpp"

namespace lasso::mdat {

// Each adds all parts and parameters to the body, in lengths of about 1 to 10, and says in a few words what it is.
std::string draw_plain(Body& body, Fitter& fitter);
std::string draw_cluttered(Body& body, Fitter& fitter);
std::string draw_symmetric(Body& body, Fitter& fitter, bool broken);
std::string draw_spent_stage(Body& body, Fitter& fitter);
std::string draw_rock(Body& body, Fitter& fitter);
std::string draw_unknowable(Body& body, Fitter& fitter);

}  // namespace lasso::mdat
