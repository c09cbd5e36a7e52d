#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace platform::validation {

/// A picture as a gnuplot script.
struct Plot {
  std::string name;     ///< of its file, without .svg
  std::string caption;  ///< one sentence
  std::string figures;  ///< of the thesis: "5.29"
  std::string script;   ///< without terminal and output
};

/// Builds a script: data first, then panels in a grid, each with commands of its own.
class PlotScript {
 public:
  /// A panel of 400 x 300 px for each cell.
  PlotScript(int columns, int rows);

  /// A table of numbers under that name ("$name").
  void data(const std::string& name, const std::vector<std::vector<double>>& rows);
  /// Commands until the next panel, which ends with its plot command.
  void panel(const std::string& title, const std::string& x_label, const std::string& y_label,
             const std::string& commands);
  std::string text() const;

 private:
  int columns_, rows_;
  std::string data_, panels_;
};

/// Writes `name`.svg into the folder. False: gnuplot is not installed. Throws vp::InputError if it
/// failed.
bool draw(const Plot& plot, const std::filesystem::path& folder);

}  // namespace platform::validation
