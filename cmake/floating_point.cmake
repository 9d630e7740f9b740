# The same source gives the same bits: no contraction to fused multiply-add, no fast-math, no host-specific code.
add_library(strataflow_floating_point INTERFACE)
target_compile_options(strataflow_floating_point INTERFACE -ffp-contract=off)
