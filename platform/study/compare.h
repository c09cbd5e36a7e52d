#pragma once

#include <map>
#include <string>

#include <result/metrics.h>
#include <study/point.h>

namespace platform::study {

/// A run to compare: a result.json, or a point of a sweep.
struct Comparable {
  std::string name;
  std::map<std::string, std::string> configuration;  ///< and system, inputs, profile
  result::Metrics metrics;
};

/// A run with the result.json and the configuration that it made.
Comparable comparable(const std::string& name, const Json& result,
                      std::map<std::string, std::string> configuration);
/// Reads a result.json, a folder with one, or a point that is kept whole. Throws vp::InputError.
Comparable read_comparable(const std::string& path);

/// Configuration and metrics in which the two differ, as tables; says so if they differ in nothing.
std::string compare(const Comparable& a, const Comparable& b);

}  // namespace platform::study
