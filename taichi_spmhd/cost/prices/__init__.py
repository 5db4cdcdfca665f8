"""The price list: `spmhd cost SCENE --effects`."""
