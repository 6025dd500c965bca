#pragma once

namespace lorentz {

/// Provenance of an executable, defined in a source file that the build generates for each executable
/// (workflow/pipeline/sources.py). It contains no path, host or time, so that equal builds write equal
/// results.
struct BuildInfo {
  const char* version;
  const char* source_hash;  // sha256 over all sources that can change a result, and over the flags
  const char* compiler;
  const char* flags;
  const char* libraries;
};

extern const BuildInfo build_info;

}  // namespace lorentz
