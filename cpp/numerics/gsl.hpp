#pragma once

#include <memory>
#include <new>

namespace lorentz {

/// Object of GSL that one of its functions allocates and another one frees.
template <class T, auto allocate, auto release>
class GslObject {
 public:
  /// Throws std::bad_alloc.
  template <class... Arguments>
  explicit GslObject(Arguments... arguments) : object_(allocate(arguments...)) {
    if (!object_) throw std::bad_alloc();
  }

  T* get() const { return object_.get(); }

 private:
  struct Release {
    void operator()(T* object) const { release(object); }
  };
  std::unique_ptr<T, Release> object_;
};

}  // namespace lorentz
