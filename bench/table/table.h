#pragma once

#include <optional>
#include <string>
#include <vector>

#include "samples.h"

namespace bench {

/// The figures with their values, ready to print.
struct Table {
  struct Line {
    Figure figure;
    std::vector<std::optional<double>> values;  ///< by image; nothing: not measured
  };

  std::vector<std::string> images;
  std::vector<Line> lines;
};

/// Lines that were not measured on any image are left out.
Table make_table(const std::vector<Figure>& figures, const std::vector<Round>& rounds,
                 const std::vector<std::string>& images);

std::string plain_text(const Table& table);
std::string markdown(const Table& table);

/// One line for each figure of the first image that misses its `must`, loosened by `slack`: 1 is
/// the must itself, 2 half of it.
std::vector<std::string> misses(const Table& table, double slack);

/// `document` with everything between its marker lines replaced by `text`. Throws
/// std::runtime_error if a marker is missing.
std::string replace_between_markers(const std::string& document, const std::string& text);

}  // namespace bench
