#pragma once

#include <systemc>
#include <vector>

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

/// The objects of type T below `top`, in the order in which they were made; those inside one of
/// them come after it.
template <class T>
std::vector<T*> all_below(const sc_core::sc_object& top) {
  std::vector<T*> found;
  for (sc_core::sc_object* child : top.get_child_objects()) {
    if (auto* object = dynamic_cast<T*>(child)) found.push_back(object);
    const std::vector<T*> inner = all_below<T>(*child);
    found.insert(found.end(), inner.begin(), inner.end());
  }
  return found;
}

/// Makes SystemC begin again: what is built from here on is another simulation, and time is 0. What
/// was built before must be gone. SystemC 2.3.4 cannot destroy its old context safely: each call
/// costs memory until the process ends, about 50 KiB for the whole platform (measured).
inline void begin_fresh_context() {
  static auto& contexts = *new std::vector<sc_core::sc_simcontext*>;  // kept, they are no leaks
  contexts.push_back(new sc_core::sc_simcontext);
  sc_core::sc_curr_simcontext = sc_core::sc_default_global_context = contexts.back();
}

}  // namespace vp
