#pragma once

#include <optional>
#include <systemc>

#include <vp/parameter.h>

namespace platform {

/// How the thesis' figure for blob detection is read: the parameter
/// power.blob.figure_includes_static of each design of this application.
class BlobFigure {
 public:
  /// Design::add_power_options.
  void add();
  /// Design::has_net_figures.
  bool is_net() const { return options_ && options_->figure_includes_static; }

 private:
  struct Options : sc_core::sc_module {
    explicit Options(sc_core::sc_module_name name);
    vp::Parameter<bool> figure_includes_static;
  };
  std::optional<Options> options_;
};

}  // namespace platform
