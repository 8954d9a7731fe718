#pragma once

// The figures of the project, all in one include: SvgFigure holds one SvgMap, on which the functions of SvgScenario.h
// draw, and any number of SvgPlots.
#include "parking_geometry/drawing/SvgFigure.h"
#include "parking_geometry/drawing/SvgMap.h"
#include "parking_geometry/drawing/SvgPlot.h"
#include "parking_geometry/drawing/SvgScenario.h"
