#pragma once

#include <map>
#include <string>
#include <vector>

#include <input/image_file.h>
#include <vp/configuration.h>
#include <vp/unit.h>

namespace platform::sweep {

/// What a parameter takes, as its description tells.
struct ParameterKind {
  enum class Kind { quantity, truth, text };

  Kind kind = Kind::text;
  vp::Unit unit = vp::Unit::none;  ///< of a quantity
};

ParameterKind kind_of(const vp::ParameterDescription& description);

/// The value as it stands in the effective configuration: "50000 kHz" is "50 MHz". Throws
/// vp::InputError, which continues a sentence that began with key and value, if it is malformed.
std::string normalised(const ParameterKind& kind, const std::string& text);

/// The value in the base unit; 1 and 0 for true and false. Throws vp::InputError for a text.
double number_of(const ParameterKind& kind, const std::string& text);

/// What a platform is built from, and so what a point is.
struct Build {
  std::string program;  ///< name or file of the PS program; empty: the usual
  std::map<std::string, std::string> settings;  ///< path -> value, as the user wrote it
};

/// A platform that was built, and is gone.
struct Elaborated {
  std::vector<vp::ParameterDescription> parameters;
  input::ImageSize size;
};

/// The parameters of a platform.
class ParameterTable {
 public:
  explicit ParameterTable(const Elaborated& elaborated);

  /// Throws vp::InputError for an unknown path, with the nearest; `where` says who asked.
  const vp::ParameterDescription& find(const std::string& path, const std::string& where) const;
  bool has(const std::string& path) const { return index_.count(path) != 0; }
  ParameterKind kind(const std::string& path) const;
  std::vector<std::string> paths() const;
  /// The effective values by path.
  std::map<std::string, std::string> values() const;
  /// The defaults by path: some follow from other values.
  std::map<std::string, std::string> defaults() const;
  input::ImageSize size() const { return size_; }

 private:
  std::vector<vp::ParameterDescription> parameters_;
  std::map<std::string, std::size_t> index_;
  input::ImageSize size_;
};

}  // namespace platform::sweep
