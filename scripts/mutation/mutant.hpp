// Included before every source of a mutated build (-include). A mutant is a number at a place of
// the sources; the one whose number the environment variable ORTUNG_MUTANT holds is switched on,
// all others do what the original does. ORTUNG_MUTANTS_REACHED names a file of one byte a mutant,
// which this process sets where it comes past.
#pragma once
#if __cplusplus >= 202002L  // not in CMake's own checks of the compiler
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <type_traits>

namespace ortung_mutant {

constexpr int kMost = 100000;

inline unsigned char* reached() {
  static unsigned char* const bytes = [] {
    const char* name = std::getenv("ORTUNG_MUTANTS_REACHED");
    const int file = name == nullptr ? -1 : ::open(name, O_RDWR);
    void* map =
        file < 0 ? MAP_FAILED : ::mmap(nullptr, kMost, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (file >= 0) ::close(file);
    return map == MAP_FAILED ? nullptr : static_cast<unsigned char*>(map);
  }();
  return bytes;
}

// Whether mutant `number` is switched on.
inline bool on(int number) {
  static const int active = [] {
    const char* text = std::getenv("ORTUNG_MUTANT");
    return text == nullptr ? -1 : std::atoi(text);
  }();
  if (unsigned char* bytes = reached()) bytes[number] = 1;
  return active == number;
}

template <class A, class B, class Original, class Mutated>
auto binary(int number, A a, B b, Original original, Mutated mutated) -> decltype(original(a, b)) {
  return on(number) ? static_cast<decltype(original(a, b))>(mutated(a, b)) : original(a, b);
}

// For constexpr functions: while the compiler computes, the original is meant.
template <class A, class B, class Original, class Mutated>
constexpr auto constantBinary(int number, A a, B b, Original original, Mutated mutated)
    -> decltype(original(a, b)) {
  if (std::is_constant_evaluated()) return original(a, b);
  return binary(number, a, b, original, mutated);
}

template <class T>
T value(int number, T original, T mutated) {
  return on(number) ? mutated : original;
}

template <class T>
constexpr T constantValue(int number, T original, T mutated) {
  if (std::is_constant_evaluated()) return original;
  return value(number, original, mutated);
}

}  // namespace ortung_mutant
#endif
