#include "mdat/campaign/results_h5.hpp"

#include <hdf5.h>

#include <algorithm>
#include <map>
#include <utility>

#include "mdat/common/errors.hpp"

namespace lasso::mdat {
namespace {

constexpr std::size_t kMemoryStep = std::size_t{1} << 20;  // bytes by which the file grows in memory

// An identifier of the library, closed with its scope.
class H5Object {
 public:
  H5Object(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {
    if (id < 0) throw RunError("results.h5: the HDF5 library cannot make it (no memory?)");
  }
  ~H5Object() {
    if (id_ >= 0) close_(id_);
  }
  H5Object(H5Object&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  H5Object(const H5Object&) = delete;
  H5Object& operator=(const H5Object&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void check_h5(herr_t status) {
  if (status < 0) throw RunError("results.h5: the HDF5 library cannot write it (no memory?)");
}

// Properties of a group or a dataset that is made: no time is kept, and a group keeps the order of its columns.
H5Object creation(hid_t kind) {
  H5Object properties(H5Pcreate(kind), H5Pclose);
  check_h5(H5Pset_obj_track_times(properties, false));
  if (kind == H5P_GROUP_CREATE) check_h5(H5Pset_link_creation_order(properties, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED));
  return properties;
}

// Of text with `length` bytes, the rest zeros; one at least, as the library has none of no length.
H5Object text_type(std::size_t length) {
  H5Object type(H5Tcopy(H5T_C_S1), H5Tclose);
  check_h5(H5Tset_size(type, std::max<std::size_t>(length, 1)));
  check_h5(H5Tset_strpad(type, H5T_STR_NULLPAD));
  check_h5(H5Tset_cset(type, H5T_CSET_UTF8));
  return type;
}

void put_attribute(hid_t of, const char* name, const std::string& text) {
  const H5Object type = text_type(text.size()), space(H5Screate(H5S_SCALAR), H5Sclose);
  const H5Object attribute(H5Acreate2(of, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  check_h5(H5Awrite(attribute, type, text.c_str()));
}

// `stored` and `given` are the types in the file and in memory.
void put_column(hid_t group, const std::string& name, hid_t stored, hid_t given, std::size_t count, const void* values) {
  const hsize_t size = count;
  const H5Object space(H5Screate_simple(1, &size, nullptr), H5Sclose), properties = creation(H5P_DATASET_CREATE);
  const H5Object column(H5Dcreate2(group, name.c_str(), stored, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose);
  if (count > 0) check_h5(H5Dwrite(column, given, H5S_ALL, H5S_ALL, H5P_DEFAULT, values));
  const std::string unit = unit_of(name);
  if (!unit.empty()) put_attribute(column, "unit", unit);
}

void put_numbers(hid_t file, const char* name, const std::vector<std::string>& columns, const ResultTable& table,
                 std::vector<double> CaseRow::*values) {
  const H5Object properties = creation(H5P_GROUP_CREATE);
  const H5Object group(H5Gcreate2(file, name, H5P_DEFAULT, properties, H5P_DEFAULT), H5Gclose);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    std::vector<double> column;
    for (const CaseRow& row : table.rows) column.push_back((row.*values)[i]);
    put_column(group, columns[i], H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, column.size(), column.data());
  }
}

void put_cases(hid_t file, const ResultTable& table) {
  std::vector<std::uint32_t> numbers;
  std::size_t longest = 1;
  for (const CaseRow& row : table.rows) longest = std::max(longest, row.status.size());
  std::string texts;
  for (const CaseRow& row : table.rows) {
    numbers.push_back(row.number);
    texts += row.status + std::string(longest - row.status.size(), '\0');
  }
  const H5Object type = text_type(longest);
  put_column(file, "case", H5T_STD_U32LE, H5T_NATIVE_UINT32, numbers.size(), numbers.data());
  put_column(file, "status", type, type, numbers.size(), texts.data());
}

std::string image_of(hid_t file) {
  check_h5(H5Fflush(file, H5F_SCOPE_LOCAL));
  const ssize_t size = H5Fget_file_image(file, nullptr, 0);
  if (size < 0) throw RunError("results.h5: the HDF5 library cannot give its bytes");
  std::string bytes(static_cast<std::size_t>(size), '\0');
  if (H5Fget_file_image(file, bytes.data(), bytes.size()) != size) throw RunError("results.h5: the HDF5 library cannot give its bytes");
  return bytes;
}

}  // namespace

std::string unit_of(const std::string& column) {
  static const std::map<std::string, std::string> units = {
      {"m", "m"},       {"mm", "mm"},   {"s", "s"},         {"us", "us"},      {"deg", "deg"},        {"degps", "deg/s"}, {"mps", "m/s"},
      {"mmps", "mm/s"}, {"rad", "rad"}, {"radps", "rad/s"}, {"mps2", "m/s^2"}, {"degps2", "deg/s^2"}, {"K", "K"},         {"hz", "Hz"}};
  const std::size_t begin = column.rfind('_');
  if (begin == std::string::npos) return "";
  const std::size_t end = column.find('.', begin);  // a number of a list: .x, .1
  const auto unit = units.find(column.substr(begin + 1, end == std::string::npos ? end : end - begin - 1));
  return unit == units.end() ? "" : unit->second;
}

std::string results_h5(const ResultTable& table, const std::string& campaign, const std::string& plan) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // it prints nothing: errors are thrown
  const H5Object access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  check_h5(H5Pset_fapl_core(access, kMemoryStep, false));  // in memory alone
  const H5Object file(H5Fcreate("results.h5", H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose);
  put_attribute(file, "campaign", campaign);
  put_attribute(file, "plan", plan);
  put_cases(file, table);
  put_numbers(file, "figures", table.figures, table, &CaseRow::figures);
  put_numbers(file, "drawn", table.columns, table, &CaseRow::drawn);
  return image_of(file);
}

}  // namespace lasso::mdat
