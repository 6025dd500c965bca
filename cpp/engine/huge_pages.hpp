#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <new>

namespace lorentz {

/// For large arrays that are read in random order: asks for huge pages where the system has them. Particles
/// in pages of 4 KiB are further apart than the processor's table of pages reaches from some 10^5 of them on.
template <class T>
struct HugePageAllocator {
  using value_type = T;

  static constexpr std::size_t page = std::size_t{2} << 20;  // bytes; x86-64 and most ARM systems

  T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    void* memory = ::operator new(bytes, alignment(count));
#ifdef MADV_HUGEPAGE
    if (bytes >= page) madvise(memory, bytes, MADV_HUGEPAGE);  // a matter of speed only: may be refused
#endif
    return static_cast<T*>(memory);
  }

  void deallocate(T* memory, std::size_t count) { ::operator delete(memory, alignment(count)); }

  bool operator==(const HugePageAllocator&) const = default;

 private:
  static std::align_val_t alignment(std::size_t count) {
    return std::align_val_t(count * sizeof(T) >= page ? page : alignof(T));
  }
};

}  // namespace lorentz
