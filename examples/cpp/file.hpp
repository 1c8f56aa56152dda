// Reads a whole file; the examples have nothing else to do with files.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

inline std::vector<std::uint8_t> read_file(const char *path) {
  std::FILE *file = std::fopen(path, "rb");
  if (file == nullptr) {
    std::perror(path);
    std::exit(EXIT_FAILURE);
  }
  std::vector<std::uint8_t> bytes;
  std::uint8_t some[4096];
  for (std::size_t count; (count = std::fread(some, 1, sizeof some, file)) > 0;)
    bytes.insert(bytes.end(), some, some + count);
  std::fclose(file);
  return bytes;
}
