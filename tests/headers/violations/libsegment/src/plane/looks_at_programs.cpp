// SPDX-License-Identifier: MIT
#include "../../../apps/segment/run.hpp"
#include <pcl/point_cloud.h>
