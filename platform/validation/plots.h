#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <validation/measured.h>
#include <validation/validation.h>

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

/// Pictures like figures 5.19 to 5.45 of the thesis: the increased-feature test, all tests,
/// accuracy. `work`: of the frames of marker_tests, in order.
std::vector<Plot> feature_plots(const Validation& validation);
std::vector<Plot> test_plots(const Validation& validation, const std::vector<ImageWork>& work);
std::vector<Plot> accuracy_plots(const Validation& validation);

/// All of them, and what they need counted in the images.
std::vector<Plot> all_plots(const Validation& validation);

/// A dashed line at a published value: "VALUE with lines ls 9 title 'thesis, mean'".
std::string published_line(const Validation& validation, const std::string& id, double scale = 1);

/// Value of a published row; throws std::out_of_range if there is none.
double published_value(const Validation& validation, const std::string& id);

/// What varies in a test: -0.5 of "x-0.5", 30 of "roll30".
double position_of(const Frame& frame);

}  // namespace platform::validation
