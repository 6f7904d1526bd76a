"""The report on the extended robust Kalman filter."""
