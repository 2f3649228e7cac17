#pragma once
/// Marks what other shared objects may use; everything else is hidden.
#define ORTUNG_API __attribute__((visibility("default")))
