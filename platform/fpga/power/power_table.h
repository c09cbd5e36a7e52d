#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <vp/power_meter.h>

namespace platform::power {

/// One coefficient with its origin.
struct Coefficient {
  std::string name;
  std::string unit;
  vp::Band value;
  std::string status;  ///< "measured", "published", "derived" or "assumed"
  std::string source;
};

/// The coefficients of the power model: a JSON file with every name that the model knows.
///
///   {"version": 1, "device": "xc7z020", "name": "zynq7020", "entries": [
///     {"name": "ps.pll", "unit": "W", "low": 0.025, "nominal": 0.025, "high": 0.027,
///      "status": "derived", "source": "..."}, ...]}
class PowerTable {
 public:
  /// `name`: an installed table, or a file that ends in .json. Throws vp::InputError, with the
  /// file and the entry, for a file that is not such a table: an entry that is unknown, missing or
  /// there twice, a value that is negative or beyond what the quantity can be, low > nominal or
  /// nominal > high, another unit, version or device.
  static PowerTable load(const std::string& name);

  /// The part that the coefficients were read from. Others of the family differ in static power.
  static constexpr const char* part = "xc7z020";

  /// As the file calls itself.
  const std::string& name() const { return name_; }
  /// In the order of the model, not of the file.
  const std::vector<Coefficient>& entries() const { return entries_; }
  /// Throws std::logic_error for a name that the model does not know.
  const Coefficient& at(const std::string& name) const;
  /// In the unit of the table.
  const vp::Band& value(const std::string& name) const { return at(name).value; }
  /// 64-bit FNV-1a hash of the values, 16 hexadecimal digits.
  std::string hash() const;

 private:
  std::string name_;
  std::vector<Coefficient> entries_;
};

/// The table as a page of Markdown.
std::string as_markdown(const PowerTable& table);

/// A coefficient that the model uses. Zero is the least for all; more than `most` is a slip of the
/// pen: ten times what any 28 nm device was seen to take, or more.
struct KnownCoefficient {
  const char* name;
  const char* unit;
  double most;
};

const std::vector<KnownCoefficient>& known_coefficients();

}  // namespace platform::power
