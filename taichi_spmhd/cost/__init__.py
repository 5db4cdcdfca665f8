"""What accuracy costs in time: `spmhd cost`."""
