// SPDX-License-Identifier: MIT
// Not compiled: what check_layering.cmake must see.
#include "ph/core/good.hpp"
#include "ph/metric.hpp"
#include <pcl/point_cloud.h>
