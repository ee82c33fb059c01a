// Compiled models that are kept from run to run, one a file, under the digest of all that a model depends on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

#include "mdat/modelc/model.hpp"

namespace lasso::mdat {

constexpr std::uint64_t kModelCacheBytes = std::uint64_t{1} << 30;

// Which compiler of models this program has: version, number type, digest of the sources, and what compiled those.
std::string model_compiler();

// The digest of all that a model depends on, in 64 characters.
std::string model_key(const std::string& compiler, const Mesh& mesh, const ModelOptions& options);

struct ModelCacheOptions {
  std::filesystem::path folder;                // made when the first entry is written; empty: no cache
  std::uint64_t bytes_max = kModelCacheBytes;  // of all entries; those used longest ago are removed first
  std::string compiler = model_compiler();
};

// Safe with any number of processes: an entry appears whole, and is believed only if it is whole and its own. What goes wrong with the
// folder costs a compilation, nothing else.
class ModelCache {
 public:
  explicit ModelCache(ModelCacheOptions options) : options_(std::move(options)) {}
  // In MDAT_CACHE, else $XDG_CACHE_HOME/3dlasso, else ~/.cache/3dlasso; none where none of the variables is set.
  static ModelCache of_user();
  static ModelCache none() { return ModelCache(ModelCacheOptions{}); }
  static ModelCache of_user_if(bool wanted) { return wanted ? of_user() : none(); }

  // As compile_model, which it calls where there is no entry.
  ModelTables compile(const Mesh& mesh, const ModelOptions& options, CompileReport& report);

  // Whether there is a sound entry of this key; it then counts as used.
  bool find(const std::string& key, ModelTables& tables, CompileReport& report) const;
  void keep(const std::string& key, const ModelTables& tables, const CompileReport& report);

  // How many models came from an entry.
  std::size_t found() const { return found_; }
  const std::filesystem::path& folder() const { return options_.folder; }
  // Why an entry could not be written, for a person; empty: none failed.
  const std::string& warning() const { return warning_; }

 private:
  std::filesystem::path file_of(const std::string& key) const;
  void remove_oldest() const;

  ModelCacheOptions options_;
  std::size_t found_ = 0;
  std::string warning_;
};

}  // namespace lasso::mdat
