"""The extended robust Kalman filter: the state of a system whose matrices are known up to a bounded uncertainty."""

ALLOCATION_FREE = True
