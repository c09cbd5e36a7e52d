#ifndef BSPCONFIG_H
#define BSPCONFIG_H

/* What drivers ask of a board support package's build: a Zynq-7000, one CPU, secure. */

#define PLATFORM_ZYNQ

#endif
