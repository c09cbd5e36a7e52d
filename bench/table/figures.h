#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "samples.h"

namespace bench {

/// One line of the table.
struct Figure {
  enum class Better { higher, lower };

  std::string title;
  std::optional<double> must, aim;  ///< on the first image; nothing: for comparison only
  std::string unit;                 ///< "×", "ms", "MB"
  Better better = Better::higher;
  /// Of one round and image; nothing if it was not measured.
  std::function<std::optional<double>(const Round&, const std::string& image)> value;

  bool satisfies(double value, double bound) const {
    return better == Better::higher ? value >= bound : value <= bound;
  }
};

/// All of them, in the order of the table. `fidelity` of the whole system, for the titles.
std::vector<Figure> figures(const std::string& fidelity);

/// A figure's value on one image: the median over the rounds.
std::optional<double> reached(const Figure& figure, const std::vector<Round>& rounds,
                              const std::string& image);

}  // namespace bench
