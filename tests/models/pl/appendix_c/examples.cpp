#include "examples.h"

#include <stdexcept>

#include "blob_examples.h"
#include "fast_examples.h"
#include "suppression_example.h"
#include "threshold_examples.h"

namespace appendix_c {

const std::vector<Example>& examples() {
  static const std::vector<Example> all{
      {"c01_threshold_component", trace_threshold_component},
      {"c02_contiguity", trace_contiguity},
      {"c03_direction", trace_direction},
      {"c04_strength", trace_strength},
      {"c05_non_maximum_suppression", trace_non_maximum_suppression},
      {"c06_pixel_threshold", trace_pixel_threshold},
      {"c07_next_threshold", trace_next_threshold},
      {"c08_new_label", trace_new_label},
      {"c09_existing_label", trace_existing_label},
      {"c10_bounding_box", trace_bounding_box},
      {"c11_deactivated_label", trace_deactivated_label},
      {"c12_blob_filter", trace_blob_filter},
  };
  return all;
}

void write_trace(const std::string& name, const std::filesystem::path& file) {
  for (const Example& example : examples()) {
    if (example.name == name) {
      example.write_trace(file);
      return;
    }
  }
  throw std::out_of_range("no example is called " + name);
}

}  // namespace appendix_c
