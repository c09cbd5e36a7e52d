#pragma once

#include <string>

#include <sweep/expression.h>

namespace platform::sweep {

/// "max summary.fps.mean", "min power.total_w.nominal / summary.fps.mean".
class Objective {
 public:
  /// Throws vp::InputError; `where` says where it stands.
  Objective(const std::string& text, const std::string& where);

  bool maximise() const { return maximise_; }
  const Expression& figure() const { return figure_; }

 private:
  bool maximise_;
  Expression figure_;
};

}  // namespace platform::sweep
