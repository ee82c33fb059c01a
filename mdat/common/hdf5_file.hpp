// Files of HDF5 that are made in memory: tables that other programs read. The same content gives the same bytes: no times of objects.
#pragma once

#include <hdf5.h>

#include <algorithm>
#include <string>
#include <utility>

#include "mdat/common/errors.hpp"

namespace lasso::mdat {

// An identifier of the library, closed with its scope.
class H5Object {
 public:
  H5Object(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {
    if (id < 0) throw RunError("the HDF5 library cannot make it (no memory?)");
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

inline void check_h5(herr_t status) {
  if (status < 0) throw RunError("the HDF5 library cannot write it (no memory?)");
}

// Properties of a group or a dataset that is made: no time is kept, and a group keeps the order of its columns.
inline H5Object creation(hid_t kind) {
  H5Object properties(H5Pcreate(kind), H5Pclose);
  check_h5(H5Pset_obj_track_times(properties, false));
  if (kind == H5P_GROUP_CREATE) check_h5(H5Pset_link_creation_order(properties, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED));
  return properties;
}

// Of text with `length` bytes, the rest zeros; one at least, as the library has none of no length.
inline H5Object text_type(std::size_t length) {
  H5Object type(H5Tcopy(H5T_C_S1), H5Tclose);
  check_h5(H5Tset_size(type, std::max<std::size_t>(length, 1)));
  check_h5(H5Tset_strpad(type, H5T_STR_NULLPAD));
  check_h5(H5Tset_cset(type, H5T_CSET_UTF8));
  return type;
}

inline void put_attribute(hid_t of, const char* name, const std::string& text) {
  const H5Object type = text_type(text.size()), space(H5Screate(H5S_SCALAR), H5Sclose);
  const H5Object attribute(H5Acreate2(of, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  check_h5(H5Awrite(attribute, type, text.c_str()));
}

// `stored` and `given` are the types in the file and in memory.
inline H5Object h5_column(hid_t group, const std::string& name, hid_t stored, hid_t given, std::size_t count, const void* values) {
  const hsize_t size = count;
  const H5Object space(H5Screate_simple(1, &size, nullptr), H5Sclose), properties = creation(H5P_DATASET_CREATE);
  H5Object column(H5Dcreate2(group, name.c_str(), stored, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose);
  if (count > 0) check_h5(H5Dwrite(column, given, H5S_ALL, H5S_ALL, H5P_DEFAULT, values));
  return column;
}

inline H5Object h5_group(hid_t file, const std::string& name) {
  const H5Object properties = creation(H5P_GROUP_CREATE);
  return {H5Gcreate2(file, name.c_str(), H5P_DEFAULT, properties, H5P_DEFAULT), H5Gclose};
}

// A file that is in memory alone.
inline H5Object h5_in_memory() {
  constexpr std::size_t kMemoryStep = std::size_t{1} << 20;  // bytes by which it grows
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);               // it prints nothing: errors are thrown
  const H5Object access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  check_h5(H5Pset_fapl_core(access, kMemoryStep, false));
  return {H5Fcreate("in_memory.h5", H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose};
}

inline std::string image_of(hid_t file) {
  check_h5(H5Fflush(file, H5F_SCOPE_LOCAL));
  const ssize_t size = H5Fget_file_image(file, nullptr, 0);
  if (size < 0) throw RunError("the HDF5 library cannot give its bytes");
  std::string bytes(static_cast<std::size_t>(size), '\0');
  if (H5Fget_file_image(file, bytes.data(), bytes.size()) != size) throw RunError("the HDF5 library cannot give its bytes");
  return bytes;
}

}  // namespace lasso::mdat
