#pragma once

#include <map>
#include <string>

#include <result/metrics.h>

namespace platform::study {

/// A run to compare: a result.json, or a point of a sweep.
struct Comparable {
  std::string name;
  std::map<std::string, std::string> configuration;  ///< and system, inputs, profile
  result::Metrics metrics;
};

/// Reads a result.json, a folder with one, or a point's file. Throws vp::InputError.
Comparable read_comparable(const std::string& path);

/// Configuration and metrics in which the two differ, as tables; says so if they differ in nothing.
std::string compare(const Comparable& a, const Comparable& b);

}  // namespace platform::study
