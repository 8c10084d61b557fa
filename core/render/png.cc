#include "core/render/scene.h"
