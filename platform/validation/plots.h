#pragma once

#include <vector>

#include <validation/gnuplot.h>
#include <validation/image_work.h>
#include <validation/validation.h>

namespace platform::validation {

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
