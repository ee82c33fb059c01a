// A campaign's table as an HDF5 file, for programs that read numbers and not text.
#pragma once

#include <string>

#include "mdat/campaign/result_table.hpp"

namespace lasso::mdat {

// The unit that a column's name ends with ("truth.spin_degps.x": deg/s); empty where it says none.
std::string unit_of(const std::string& column);

// The bytes of a file: datasets `case` (unsigned, 32 bits), `status` (text of one length), and one of doubles a column in the groups
// `figures` and `drawn`, in the table's order; not a number as in the table. Attributes: `campaign` and `plan` (the digest of its plan) of
// the file, `unit` of a column. The same table gives the same bytes: no times of objects. Throws RunError.
std::string results_h5(const ResultTable& table, const std::string& campaign, const std::string& plan);

}  // namespace lasso::mdat
