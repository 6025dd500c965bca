#pragma once

namespace lorentz {

/// Provenance of an executable, defined in a source file that the build generates for each executable
/// (workflow/provenance/build_id.py). It contains no path, host or time, so that equal builds have equal ids.
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
