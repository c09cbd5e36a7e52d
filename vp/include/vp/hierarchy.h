#pragma once

#include <systemc>

namespace vp {

/// While it lives, SystemC objects made during elaboration become children of `parent`, as if made
/// in its constructor.
class HierarchyScope {
 public:
  explicit HierarchyScope(sc_core::sc_module& parent) { context()->hierarchy_push(&parent); }
  ~HierarchyScope() { context()->hierarchy_pop(); }
  HierarchyScope(const HierarchyScope&) = delete;
  HierarchyScope& operator=(const HierarchyScope&) = delete;

 private:
  static sc_core::sc_simcontext* context() { return sc_core::sc_get_curr_simcontext(); }
};

}  // namespace vp
