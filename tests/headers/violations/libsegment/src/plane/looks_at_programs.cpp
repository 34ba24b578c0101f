// SPDX-License-Identifier: MIT
#include <pcl/point_cloud.h>
#include "../../../apps/segment/run.hpp"
