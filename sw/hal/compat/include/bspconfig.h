#ifndef BSPCONFIG_H
#define BSPCONFIG_H

/* What drivers ask of a board support package's build: one CPU, secure. */

#endif
