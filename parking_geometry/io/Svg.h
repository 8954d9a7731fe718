#pragma once

// The figures of the project, all in one include: SvgFigure holds one SvgMap, on which the functions of SvgScenario.h
// draw, and any number of SvgPlots.
#include "parking_geometry/io/SvgFigure.h"
#include "parking_geometry/io/SvgMap.h"
#include "parking_geometry/io/SvgPlot.h"
#include "parking_geometry/io/SvgScenario.h"
