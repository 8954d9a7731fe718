#pragma once

// All SVG figures in one include. An SvgFigure holds one SvgMap and any number of SvgPlots. The functions of
// SvgScenario.h draw on the map.
#include "parking_geometry/drawing/SvgFigure.h"
#include "parking_geometry/drawing/SvgMap.h"
#include "parking_geometry/drawing/SvgPlot.h"
#include "parking_geometry/drawing/SvgScenario.h"
