// The needle on one axis, for firmware: Proxy1d<ThickLawF>. docs: integrations/firmware/README.md.
#pragma once
#include "punctura/model/thick_law.hpp"
#include "punctura/proxy/proxy_1d.hpp"
