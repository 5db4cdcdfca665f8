"""taichi_spmhd."""
