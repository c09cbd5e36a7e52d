#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <vp/ip.h>

namespace platform::synthesis {

/// What synthesis made of the RTL that comes with markervp: rtl/synthesis.json, as `markervp rtl
/// synth` wrote it.
class KnownFigures {
 public:
  /// Of a module at one value of its parameters.
  struct Point {
    double lut = 0, ff = 0, bram36 = 0, dsp = 0;
    std::uint64_t fmax_hz = 0, fmax_high_hz = 0;  ///< 0: no path from register to register
    std::string at;                               ///< "LABELS=64"; "between … and …"
    std::string limited_by;  ///< what of the chip is no faster than `fmax_high_hz`; may be empty
    bool beyond = false;     ///< outside of what was synthesised: the last two points, continued
  };

  /// What is installed, read once. Throws vp::InputError if it is not there.
  static const KnownFigures& installed();
  /// Throws vp::InputError for a file that is not one of this kind.
  static KnownFigures load(const std::filesystem::path& file);

  /// Parameters that the figures do not name are at their default. What was synthesised at the
  /// values given comes first. Between two values of another parameter counts are on a line, and
  /// Fmax is the range of both. Beyond them the line continues, and the low end of
  /// Fmax falls as if all of the path were a tree over the parameter. None: no such module.
  std::optional<Point> find(const vp::IpEstimate::Rtl& rtl) const;

  /// Puts the figures into an estimate with RTL (vp::IpEstimate::Rtl); others stay as they are.
  ///
  /// Where a user's RTL is in the place of the model, they are those of a file of its own
  /// synthesis, made of the same sources with the same parameters; or these here, if it is the RTL
  /// that comes along; else they are not known. `module` is its name. Throws vp::InputError for a
  /// file that the user names and that is of other RTL.
  void apply(vp::IpEstimate& estimate, const std::string& module) const;

 private:
  struct Entry {
    std::string module;
    std::map<std::string, std::int64_t> parameters;
    std::map<std::string, std::uint64_t> built_with;  ///< all of them
    std::map<std::string, std::string> sources;       ///< hash by name; empty: not noted
    std::string not_covered;                          ///< by Fmax, for people
    Point point;

    /// Empty: it is of that RTL; else why not.
    std::string mismatch(const vp::IpEstimate::Foreign& foreign) const;
  };
  void apply_to_model(vp::IpEstimate& estimate) const;
  /// Empty: an entry is of the RTL of the estimate, which has its figures now; else why none is.
  std::string apply_to_foreign(vp::IpEstimate& estimate, const std::string& file) const;

  std::string tool_;
  std::vector<Entry> entries_;
};

}  // namespace platform::synthesis
