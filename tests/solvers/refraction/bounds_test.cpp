// Bounds by windows on whole surfaces.
#include <gtest/gtest.h>
