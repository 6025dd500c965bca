#pragma once

namespace lorentz {

/// What an executable was built from. Defined in a source that the build generates for each
/// executable (workflow/provenance/build_id.py); it names no path, host or time.
struct BuildInfo {
  const char* version;
  const char* source_hash;  // sha256 over the include closure
  const char* build_id;     // sha256 over source hash, compiler, flags and libraries
  const char* compiler;
  const char* flags;
  const char* libraries;
};

extern const BuildInfo build_info;

}  // namespace lorentz
