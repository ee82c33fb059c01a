// The report of a campaign: one HTML file that needs nothing else, with figures by gnuplot.
#pragma once

#include <string>

#include "mdat/campaign/findings.hpp"
#include "mdat/report/plotter.hpp"

namespace lasso::mdat {

// `mission` is its title. The same findings give the same page. A figure that cannot be drawn is a line in it that says why, and the
// plotter's missing().
std::string campaign_html(Plotter& plotter, const Findings& all, const std::string& mission);

}  // namespace lasso::mdat
