"""One filter's jobs by every source of costs: counted, on emulated cores, timed here, published of boards."""
