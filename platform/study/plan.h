#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <study/axes.h>
#include <study/manifest.h>
#include <study/spec.h>
#include <vp/expression.h>

namespace platform::study {

/// What planning asks of the platform.
struct Platform {
  /// Builds it in a process of its own. Throws vp::InputError that says what the user got wrong.
  std::function<Elaborated(const Setup&, const std::string& origin)> elaborate;
  /// Builds many as elaborate() would, several in a process. Those without an answer are for
  /// elaborate(), which says what is wrong with them. Null: there is no such way.
  std::function<std::vector<std::optional<Elaborated>>(const std::vector<Setup>&,
                                                       const std::string& origin)>
      elaborate_many;
  /// The file of a PS program that is named, or that belongs to the design; empty if there are no
  /// files.
  std::function<std::string(const std::string& program, const std::string& design)> program_file;
  std::string version;
  std::string revision;
};

struct PlanOptions {
  std::optional<std::uint64_t> limit;  ///< points at most
  bool yes = false;                    ///< the user wants many
};

/// More points need --yes or --limit.
inline constexpr double most_points_unasked = 100'000;
/// More points no machine gets through.
inline constexpr double most_points = 10'000'000;

/// Points that cannot be built.
struct Refusals {
  std::map<std::string, std::uint64_t> reasons;  ///< and how many points each refuses
  std::uint64_t built = 0;                       ///< points that can be built
  std::uint64_t points() const;
};

/// Builds the platform of each point, of `most` points at most.
Refusals try_points(const Manifest& manifest, const Platform& platform, std::size_t most);

/// The points of a sweep's file one by one, as a search asks for them.
class Space {
 public:
  /// Checks what plan() checks, and that `spec` draws no sample. Throws vp::InputError.
  Space(const Spec& spec, const Platform& platform);
  ~Space();

  const Spec& spec() const;
  const std::vector<AxisGroup>& groups() const;
  /// How many points there are, whatever the constraints; infinite with a range without step.
  double size() const;
  /// The constraints on parameters alone.
  const std::vector<vp::Expression>& conditions() const;
  /// What a name in one of them means for a point.
  vp::ExpressionValue value(const Assignment& point, const std::string& name) const;

  /// Its key and all that a run of it needs; manifest() then has its family and inputs.
  Point point(const Assignment& assignment);
  /// Without points, but for those that the caller adds.
  Manifest& manifest();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Checks all keys, units, ranges, names and inputs, and finds every point. Throws vp::InputError.
Manifest plan(const Spec& spec, const PlanOptions& options, const Platform& platform);

}  // namespace platform::study
